# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Reads a PLY file with VTK; prints a line a point: x y z, and red green blue where there are colours."""
import sys

from vtkmodules.vtkIOPLY import vtkPLYReader

reader = vtkPLYReader()
reader.SetFileName(sys.argv[1])
reader.Update()
points = reader.GetOutput()
colors = points.GetPointData().GetArray("RGB")
for i in range(points.GetNumberOfPoints()):
    print(*points.GetPoint(i), *(map(int, colors.GetTuple(i)) if colors else ()))
