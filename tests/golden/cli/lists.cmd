list orbits --dimension 2
list embeddings --dimension 3
