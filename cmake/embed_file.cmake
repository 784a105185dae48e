# cmake -DINPUT=FILE -DOUTPUT=FILE.cpp -DHEADER=PATH -DNAME=kName -P embed_file.cmake
# Writes a source that defines the bytes of INPUT as HEADER declares them: kName and kNameBytes, in
# namespace foretouch::tools.
file(READ ${INPUT} digits HEX)
string(LENGTH "${digits}" length)
math(EXPR bytes "${length} / 2")
string(REGEX REPLACE "(................................)" "\\1\n" lines "${digits}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," values "${lines}")
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace foretouch::tools {

const unsigned char ${NAME}[] = {
${values}};
const std::size_t ${NAME}Bytes = ${bytes};

}  // namespace foretouch::tools
")
