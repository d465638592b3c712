study %d/expectations_met.yaml --methods rk5 --dt 0.1
