module m() { children(1e30); echo(parent_module(1e30), search("a", "b", 1e30), search([1], [1], 0/0, 1e300)); } m() cube(1);
