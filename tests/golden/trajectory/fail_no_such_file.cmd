info %d/files/nowhere.vtkhdf
