#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Prints a line for each line of a .vtp as VTK reads it: its two ends, then its cell data in alphabetical order."""
import sys

import vtk

reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
lines = reader.GetOutput()
data = lines.GetCellData()
arrays = sorted((data.GetArray(k) for k in range(data.GetNumberOfArrays())), key=lambda array: array.GetName())
for n in range(lines.GetNumberOfCells()):
    cell = lines.GetCell(n)
    assert cell.GetCellType() == vtk.VTK_LINE
    values = [c for end in (0, 1) for c in lines.GetPoint(cell.GetPointId(end))]
    print(*values, *(v for array in arrays for v in array.GetTuple(n)))
