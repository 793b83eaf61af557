#include "render/meshing/mesher.h"
