view x.vtkhdf --frames 0
