view %d/files/text.vtkhdf
