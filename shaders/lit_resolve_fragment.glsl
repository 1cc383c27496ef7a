// Makes a picture of its samples. Those of ground, black as yet, are lit here, each at its own
// place: once, however many triangles touch the pixel. A constant piece before this one says
// whether it is for parts of the picture where a texel of the light is larger than a sample
// (enlarged): a look-up of a level that varies costs software drivers three times as much.
uniform sampler2DMS greys;
uniform sampler2DMS depths;
uniform vec2 sample_at[4];   // within the pixel, 0 .. 1
uniform mat3 ray_of_window;  // of (x, y, 1) in pixels; W, 1 m along the optical axis
uniform vec3 camera_W;
uniform vec3 up;  // of the ground's plane, of any length
uniform vec2 near_far_m;
uniform float sample_texels;  // of a footprint of one metre: a sample's share of the pixel
in vec2 ndc;
out vec4 colour;

const float kGrazing = 0.05;  // no footprint is longer than at this sine of incidence

// A pixel's steps to the right and down on the ground's plane, north and east, for one metre along
// the optical axis. LitResolve::Enlarged asks the same on the processor.
mat2 Steps() {
  vec3 ray = ray_of_window * vec3(gl_FragCoord.xy, 1.0);
  float down = max(-dot(up, ray), kGrazing * length(up) * length(ray));
  vec3 dx = ray_of_window[0] + ray * (dot(up, ray_of_window[0]) / down);
  vec3 dy = ray_of_window[1] + ray * (dot(up, ray_of_window[1]) / down);
  return mat2(dx.xy, dy.xy);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  mat2 steps = Steps();
  float texels_per_m =
      sample_texels * sqrt(max(dot(steps[0], steps[0]), dot(steps[1], steps[1])));
  float solid = 0.0, ground = 0.0, count = 0.0;
  vec3 places_W = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    float grey = texelFetch(greys, pixel, i).r;
    float window = texelFetch(depths, pixel, i).r;
    float depth_m = near_far_m.x * near_far_m.y /
                    (near_far_m.y - window * (near_far_m.y - near_far_m.x));
    vec3 place_W = camera_W + depth_m * (ray_of_window * vec3(vec2(pixel) + sample_at[i], 1.0));
    // In the middle of its quarter of the pixel: samples lie elsewhere, to find edges.
    vec2 on = 0.5 * floor(2.0 * sample_at[i]) + 0.25 - sample_at[i];
    vec2 look = place_W.xy + depth_m * (steps * on);
    float level = enlarged ? 0.0 : log2(depth_m * texels_per_m);
    float light = textureLod(lit, OnPicture(look), level).r;
    float is_ground = grey > 0.0 ? 0.0 : 1.0;
    solid += grey;
    ground += is_ground * light;
    places_W += is_ground * place_W;
    count += is_ground;
  }
  float left = LightLeft(places_W / max(count, 1.0));
  colour = vec4(vec3(0.25 * (solid + ground * left)), 1.0);
}
