study x.yaml --methods rk4 --dt 1e-3,fast
