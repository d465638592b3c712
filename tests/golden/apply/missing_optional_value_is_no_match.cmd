apply warm %d/files/optional.rule --mesh grid:quads:1x1
