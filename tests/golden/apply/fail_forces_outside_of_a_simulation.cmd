apply separate_elements --mesh grid:quads:2x2 --where "norm(force_on(vertex(a))) > 0"
