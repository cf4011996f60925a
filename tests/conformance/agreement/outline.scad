// openscad makes no solid, but an outline
square(3);
