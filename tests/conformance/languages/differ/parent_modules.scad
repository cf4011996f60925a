// Arguments see the depth of the call in 2021, that of the caller in 2026.
module show(t) { echo(t, $parent_modules); }
module given(t = $parent_modules) { echo(t); }
module outer() { show($parent_modules); show(t = $parent_modules); given(); }
module children_of() { x = $parent_modules; children(); echo(x); }
outer();
children_of() { show($parent_modules); given(); }
