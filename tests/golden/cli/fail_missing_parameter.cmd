apply extrude_edge --mesh grid:quads:2x2
