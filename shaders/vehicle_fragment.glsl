#version 330 core
in vec3 normal_W;
in float albedo;
uniform vec3 eye_direction_W;  // from the vehicle to the eye
out vec4 colour;
void main() {
  vec3 n = normalize(normal_W);
  vec3 key = normalize(eye_direction_W + vec3(0.1, -0.5, -0.9));
  float lit = 0.34 + 0.62 * max(dot(n, key), 0.0) + 0.12 * max(-n.z, 0.0);
  float shine = pow(max(dot(n, normalize(key + eye_direction_W)), 0.0), 24.0);
  colour = vec4(vec3(0.97, 0.985, 1.0) * albedo * lit + 0.16 * shine, 1.0);
}
