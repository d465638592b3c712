snapshot %d/files/text.vtkhdf -o %d/files/text.vtkhdf
