apply separate_elements --mesh grid:mix4:3x3 --where "a.position.x < 0.4" --validate
apply separate_elements --mesh grid:mix4:3x3 --where "a.position.x < 0.4" --validate --matcher naive
