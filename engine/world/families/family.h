// How each family is drawn; one file a family. Every function fills a bare world.
#pragma once

#include "engine/core/random.h"
#include "engine/world/world.h"

namespace palace {

void DrawRocks(World& world, RandomStream& random);
void DrawRough(World& world, RandomStream& random);
void DrawSlopes(World& world, RandomStream& random);
void DrawDitches(World& world, RandomStream& random);
void DrawKerbs(World& world, RandomStream& random);
void DrawPosts(World& world, RandomStream& random);
void DrawBushes(World& world, RandomStream& random);
void DrawDunes(World& world, RandomStream& random);
void DrawShadows(World& world, RandomStream& random);
void DrawWater(World& world, RandomStream& random);
void DrawRoof(World& world, RandomStream& random);
void DrawRunway(World& world, RandomStream& random);
void DrawObstacles(World& world, RandomStream& random);
void DrawCity(World& world, RandomStream& random);
void DrawSnow(World& world, RandomStream& random);
void DrawRmax(World& world, RandomStream& random);
void DrawNowhere(World& world, RandomStream& random);
void DrawOne(World& world, RandomStream& random);

}  // namespace palace
