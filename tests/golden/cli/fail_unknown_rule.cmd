apply separate_element --mesh grid:quads:2x2
