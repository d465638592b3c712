apply extrude_face --mesh grid:quads:2x2 --param "offset=(0,0,1)"
