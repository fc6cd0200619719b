#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Prints, of the mesh in a .ply or .obj as VTK reads it: points, faces, edges that are not shared by exactly two faces
of opposite direction, signed volume, the least cosine between a point's normal and its faces' normals."""
import collections
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

reader = {"ply": vtk.vtkPLYReader, "obj": vtk.vtkOBJReader}[sys.argv[1][-3:]]()
reader.SetFileName(sys.argv[1])
reader.Update()
mesh = reader.GetOutput()
x = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
faces = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(mesh.GetNumberOfPolys(), 4)

edges = collections.Counter()
for face in faces:
    edges.update(zip(face.tolist(), np.roll(face, -1).tolist()))
bad = sum(1 for (a, b), count in edges.items() if count != 1 or edges[b, a] != 1)

a, b, c, d = (x[faces[:, k]] for k in range(4))
volume = (np.einsum("ij,ij->i", a, np.cross(b, c)) + np.einsum("ij,ij->i", a, np.cross(c, d))).sum() / 6
face_normals = np.cross(c - a, d - b)
face_normals /= np.linalg.norm(face_normals, axis=1)[:, None]
cosine = min(np.einsum("ij,ij->i", normals[faces[:, k]], face_normals).min() for k in range(4))
print(len(x), len(faces), bad, volume, cosine)
