run %d/a_good_scene.yaml --no-output --set bodies.clth.mass=0.2
