apply extrude_edge --mesh grid:quads:2x2 --param "offset=(0,1,0) [kg]"
