apply separate_elements --mesh %d/files/cut_short.msh
