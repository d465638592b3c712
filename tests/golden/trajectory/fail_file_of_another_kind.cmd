info %d/files/text.vtkhdf
