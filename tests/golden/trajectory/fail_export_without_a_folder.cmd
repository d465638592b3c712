export %d/files/text.vtkhdf --format obj
