apply separate_elements %d/files/no_default.rule --mesh grid:quads:1x1
