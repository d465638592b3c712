study %d/files/tearing.yaml --methods rk4 --dt 0.01
