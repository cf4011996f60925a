a = 1e3.x;
