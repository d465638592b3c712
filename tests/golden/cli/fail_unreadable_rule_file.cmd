check no/such/file.rule
