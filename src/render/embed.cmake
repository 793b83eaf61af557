# cmake -DROOT=... -DOUT=... -P embed.cmake: writes every GLSL file below ROOT into one C++ table, so that the program needs
# no shader files at run time.
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/*.glsl)
list(SORT files)
set(text "// Made by src/render/embed.cmake; do not edit.\n#include \"render/shader_library.h\"\n\nnamespace vitrail::render {\n\nconst EmbeddedShader kEmbeddedShaders[] = {\n")
foreach(file IN LISTS files)
    file(READ ${ROOT}/${file} content)
    string(APPEND text "    {\"${file}\", R\"GLSL(${content})GLSL\"},\n")
endforeach()
string(APPEND text "    {nullptr, nullptr},\n};\n\n} // namespace vitrail::render\n")
file(WRITE ${OUT} "${text}")
