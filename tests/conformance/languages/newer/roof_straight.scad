roof(method = "straight") polygon([[0, 0], [9, 0], [9, 3], [4, 3], [4, 8], [0, 8]]);
