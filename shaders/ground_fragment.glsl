// The point of the ground is computed from the pixel's own ray, not interpolated: left and right
// pictures of a place then agree to float precision.
uniform mat3 ray_W_from_pixel;  // of (gl_FragCoord.xy, 1)
uniform vec2 camera_north_east;
uniform vec3 normal_W;
uniform float plane_distance;  // along the normal, from camera to plane
uniform float ground_grey;
uniform float light;
uniform float markings;  // 0 or 1
out vec4 colour;

// Share of the pixel covered by a stripe of the given half width whose centre line is at distance d.
float Stripe(float d, float half_width, float footprint) {
  return clamp((half_width - abs(d)) / footprint + 0.5, 0.0, 1.0);
}

float Paint(vec2 p, float footprint) {
  float dash = mod(p.x, 12.0) - 6.0;
  float centre = Stripe(p.y - 1.5, 0.20, footprint) * Stripe(dash, 3.0, footprint);
  float edges = Stripe(abs(p.y - 1.5) - 11.0, 0.15, footprint);
  return max(centre, edges);
}

void main() {
  vec3 ray = ray_W_from_pixel * vec3(gl_FragCoord.xy, 1.0);
  float t = plane_distance / dot(normal_W, ray);
  vec2 p = camera_north_east + t * ray.xy;
  float footprint = max(0.5 * (length(dFdx(p)) + length(dFdy(p))), 1e-4);
  Grain grain = GrainAt(p, footprint);
  float grey = ground_grey * (1.0 + 0.16 * grain.slow) + 0.20 * grain.marks + grain.detail;
  float worn = clamp(1.0 + 2.5 * (grain.detail + 0.6 * grain.marks), 0.35, 1.0);
  float paint = markings * Paint(p, footprint) * worn;
  float painted = 0.74 + 0.8 * grain.detail + 0.15 * grain.marks;
  colour = vec4(vec3(light * mix(grey, painted, paint)), 1.0);
}
