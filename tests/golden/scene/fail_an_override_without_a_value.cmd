run %d/a_good_scene.yaml --no-output --set duration
