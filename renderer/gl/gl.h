#pragma once

/// The OpenGL 4.5 core function table (glad), loaded by createContext from the back end that was chosen.
#include <glad/gl.h>
