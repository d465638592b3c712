apply blow_up %d/files/non_finite.rule --mesh grid:quads:1x1
