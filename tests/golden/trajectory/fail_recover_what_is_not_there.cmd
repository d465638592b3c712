recover %d/files/nowhere.vtkhdf.part
