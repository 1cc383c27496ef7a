// The ground's light was worked out beforehand; only what moves darkens it here. Four look-ups a
// pixel: one of the whole footprint would blur what lies slanting.
uniform sampler2D lit;
uniform vec3 square;  // north and east of the south-west corner, size; metres
uniform float shade;  // share of the light that is left in a shadow
in vec3 place_W;
out vec4 colour;
void main() {
  vec2 uv = (place_W.yx - square.yx) / square.z;
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  float grey = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 at = vec2(i % 2 == 0 ? -0.25 : 0.25, i < 2 ? -0.25 : 0.25);
    grey += 0.25 * textureGrad(lit, uv + at.x * dx + at.y * dy, 0.35 * dx, 0.35 * dy).r;
  }
  if (has_movers) {
    vec3 above = place_W - vec3(0.0, 0.0, 0.02);
    float hidden = (1.0 - SeenPastMovers(above)) * Seen(still_map, above);
    grey *= mix(1.0, shade, hidden);
  }
  colour = vec4(vec3(grey), 1.0);
}
