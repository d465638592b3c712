apply triangulate_face --mesh grid:quads:10x10
apply subdivide_triangles --mesh grid:triangles:2x2 --times 2
apply remove_element --mesh box:hexes:3x3x3 --where "centroid(a).z > 0.6" -o %t/cut.vtu
apply split_quad --mesh grid:quads:2x2 --to face --where "random(7, face(a)) < 0.5"
apply dual --mesh grid:mix4:4x4
