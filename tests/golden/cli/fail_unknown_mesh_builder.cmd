apply separate_elements --mesh grid:quds:2x2
