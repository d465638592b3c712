// SPDX-License-Identifier: MIT
// A bean-shaped solid of about 600 tetrahedra, in metres: two lobes joined, with a notch below.
//   gmsh organ.geo -3 -format msh41 -o organ.msh
SetFactory("OpenCASCADE");

Sphere(1) = {0, 0, 0, 1};
Dilate {{0, 0, 0}, {0.075, 0.050, 0.042}} { Volume{1}; }
Sphere(2) = {0, 0, 0, 1};
Dilate {{0, 0, 0}, {0.055, 0.038, 0.032}} { Volume{2}; }
Rotate {{0, 0, 1}, {0, 0, 0}, Pi / 7} { Volume{2}; }
Translate {0.068, 0.014, 0} { Volume{2}; }
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Sphere(4) = {0.045, -0.052, 0, 0.030};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };

Physical Volume("organ", 1) = {5};

Mesh.MeshSizeMin = 0.0214;
Mesh.MeshSizeMax = 0.0214;
Mesh.Optimize = 1;
Mesh.OptimizeNetgen = 1;
