in vec2 place_m;
in float albedo;
in float light;
out vec4 colour;
void main() {
  Grain grain = GrainAt(place_m);
  float grey = albedo + (0.45 + 0.75 * albedo) * grain.detail;
  colour = vec4(vec3(light * grey), 1.0);
}
