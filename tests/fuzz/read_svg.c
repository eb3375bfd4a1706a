#define FORMAT RG_FORMAT_SVG
#include "reader.h"
