// OpenGL 3.3 core by prototypes: no loader. The render room is left unlinked; a program links
// libOpenGL (GLX and EGL alike), one test links libOSMesa.
#pragma once

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/glcorearb.h>
