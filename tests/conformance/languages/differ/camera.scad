echo($vpd, $vpr, $vpt, $vpf);
