apply separate_elements --mesh grid:quads:2x2 --where "position.w > 0"
