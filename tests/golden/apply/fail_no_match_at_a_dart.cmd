apply sew_elements --mesh grid:quads:2x2 --at 0,1
