apply separate_elements --mesh %d/files/absent.msh
