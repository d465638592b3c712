list rulez
