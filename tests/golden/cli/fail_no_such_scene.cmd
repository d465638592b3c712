cloth.yaml
