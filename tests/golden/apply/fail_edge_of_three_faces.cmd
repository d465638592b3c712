apply separate_elements --mesh %d/files/three_faces.obj
