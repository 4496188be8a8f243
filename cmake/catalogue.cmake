# triptych_techniques(API SOURCES)
# Finds the techniques that src/technique/catalogue.json lists for API. Sets SOURCES to their source files, which are called
# ID.cpp and are in the current folder. Generates the header "technique_list.hpp" with the macros TRIPTYCH_VOLUME_TECHNIQUES(X)
# and TRIPTYCH_PARTICLE_TECHNIQUES(X), which expand to X(id, needs) for each technique. CMake stops with an error if a listed
# technique has no source file or is named in unsupported.txt, or if a technique that is not listed is missing from
# unsupported.txt.
function(triptych_techniques api sources)
  set(catalogue ${PROJECT_SOURCE_DIR}/src/technique/catalogue.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${catalogue} unsupported.txt)
  file(READ ${catalogue} text)
  file(STRINGS unsupported.txt unsupported)
  string(JSON count LENGTH "${text}" techniques)
  math(EXPR last "${count} - 1")
  set(files "")
  set(volume "")
  set(particles "")
  foreach(index RANGE ${last})
    string(JSON id GET "${text}" techniques ${index} id)
    string(JSON suite GET "${text}" techniques ${index} suite)
    string(JSON needs GET "${text}" techniques ${index} needs)
    string(JSON apis GET "${text}" techniques ${index} apis)
    set(reason ${unsupported})
    list(FILTER reason INCLUDE REGEX "^${id}: .")
    if(NOT apis MATCHES "\"${api}\"")
      if(NOT reason)
        message(FATAL_ERROR "${catalogue} does not list ${api} for the technique ${id}: "
                            "add ${api} to its apis, or give the reason in backends/${api}/unsupported.txt")
      endif()
      continue()
    endif()
    if(reason)
      message(FATAL_ERROR "${catalogue} lists ${api} for the technique ${id}, but backends/${api}/unsupported.txt contains it as well")
    endif()
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${id}.cpp)
      message(FATAL_ERROR "${catalogue} lists ${api} for the technique ${id}: write backends/${api}/${id}.cpp, "
                          "or remove ${api} and give the reason in backends/${api}/unsupported.txt")
    endif()
    list(APPEND files ${id}.cpp)
    string(APPEND ${suite} " X(${id}, ${needs})")
  endforeach()
  file(CONFIGURE OUTPUT generated/technique_list.hpp CONTENT
"#pragma once
// Generated from catalogue.json: X(id, needs) for each technique.
#define TRIPTYCH_VOLUME_TECHNIQUES(X)${volume}
#define TRIPTYCH_PARTICLE_TECHNIQUES(X)${particles}
" @ONLY)
  set(${sources} ${files} PARENT_SCOPE)
endfunction()
