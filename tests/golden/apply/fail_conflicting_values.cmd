apply mark_ends %d/files/conflict.rule --mesh grid:quads:1x1
