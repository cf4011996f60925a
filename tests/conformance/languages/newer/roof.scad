roof() square([8, 5]);
