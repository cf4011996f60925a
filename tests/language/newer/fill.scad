fill() square(2);
module own() {
  module fill() echo("the design's own");
  fill();
}
own();

// expect: ECHO: "the design's own"
// expect csg: fill() {
// expect csg: \tsquare(size = [2, 2], center = false);
// expect csg: }
// expect csg: group() {
// expect csg: \tgroup();
// expect csg: }
