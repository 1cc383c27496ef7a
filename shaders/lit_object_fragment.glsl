uniform sampler2D grain;
uniform float grain_size_m;
uniform float grain_contrast;
uniform vec3 sun_W;
uniform float direct;
uniform float diffuse;
in vec3 place_W;
in vec3 normal;
in vec2 grain_at;
in float albedo;
out vec4 colour;
void main() {
  vec3 n = normalize(normal);
  float towards = max(dot(n, sun_W), 0.0);
  vec3 off = place_W + 0.04 * n;
  float seen = Seen(still_map, off) * SeenPastMovers(off);
  float detail = (255.0 * texture(grain, grain_at / grain_size_m).r - 128.0) / 127.0;
  float light = diffuse + direct * towards * seen;
  // Never quite black: that is ground which is not lit yet (ground_flag_fragment.glsl).
  colour = vec4(vec3(max(albedo * (1.0 + grain_contrast * detail) * light, 1.0 / 255.0)), 1.0);
}
