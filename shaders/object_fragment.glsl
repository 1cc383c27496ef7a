in vec2 place_m;
in float albedo;
in float light;
out vec4 colour;
void main() {
  float footprint = 0.5 * (length(dFdx(place_m)) + length(dFdy(place_m)));
  Grain grain = GrainAt(place_m, footprint);
  float grey = albedo + (0.45 + 0.75 * albedo) * grain.detail;
  colour = vec4(vec3(light * grey), 1.0);
}
