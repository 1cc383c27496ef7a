// The ground's light was worked out beforehand; only what moves darkens it when it is drawn.
uniform sampler2D lit;
uniform vec3 square;  // north and east of the south-west corner, size; metres
uniform float shade;  // share of the light that is left in a shadow

vec2 OnPicture(vec2 place) { return (place.yx - square.yx) / square.z; }  // north, east

// What is left of it past the movers.
float LightLeft(vec3 place_W) {
  if (!has_movers) return 1.0;
  vec3 above = place_W - vec3(0.0, 0.0, 0.02);
  float hidden = (1.0 - SeenPastMovers(above)) * Seen(still_map, above);
  return mix(1.0, shade, hidden);
}
