apply lowest %d/files/empty_fold.rule --mesh grid:quads:1x1
