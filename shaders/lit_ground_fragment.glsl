// Four look-ups a pixel: one of the whole footprint would blur what lies slanting.
in vec3 place_W;
out vec4 colour;
void main() {
  vec2 uv = OnPicture(place_W.xy);
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  float grey = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 at = vec2(i % 2 == 0 ? -0.25 : 0.25, i < 2 ? -0.25 : 0.25);
    grey += 0.25 * textureGrad(lit, uv + at.x * dx + at.y * dy, 0.35 * dx, 0.35 * dy).r;
  }
  colour = vec4(vec3(grey * LightLeft(place_W)), 1.0);
}
