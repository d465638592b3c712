run x.yaml --threads 0
