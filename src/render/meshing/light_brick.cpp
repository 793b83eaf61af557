#include "render/meshing/light_brick.h"
