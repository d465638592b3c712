apply open_then_count %d/files/open_face.rule --mesh grid:quads:1x1
