chek my.rule
