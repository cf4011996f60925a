// An outline that scales without a twist.
linear_extrude(height = 5, scale = [0.2, 1.5]) circle(3, $fn = 5);
