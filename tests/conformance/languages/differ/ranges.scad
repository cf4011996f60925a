// Ranges that count down without a step.
echo([for (i = [3 : 0]) i]);
for (i = [2 : 1]) echo("backwards", i);
for (i = [1 : 2]) echo("forwards", i);
echo([for (i = [3 : -1 : 0]) i], [for (i = [0 : 2 : -1]) i]);
