# triptych_techniques(API SOURCES)
# The techniques that src/technique/catalogue.json has for API. SOURCES becomes their files, ID.cpp each in
# the current folder. The generated header "technique_list.hpp" holds them for declarations and tables:
# TRIPTYCH_VOLUME_TECHNIQUES(X) and TRIPTYCH_PARTICLE_TECHNIQUES(X), X(id, needs) for each.
# A line without its file, and a file's technique called unsupported, end the configuration.
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
        message(FATAL_ERROR "${catalogue} has no ${id} for ${api}: "
                            "name ${api} among its apis, or the reason in backends/${api}/unsupported.txt")
      endif()
      continue()
    endif()
    if(reason)
      message(FATAL_ERROR "${catalogue} has ${id} for ${api}, backends/${api}/unsupported.txt says that it has not")
    endif()
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${id}.cpp)
      message(FATAL_ERROR "${catalogue} has ${id} for ${api}: write backends/${api}/${id}.cpp, "
                          "or the reason why not in backends/${api}/unsupported.txt")
    endif()
    list(APPEND files ${id}.cpp)
    string(APPEND ${suite} " X(${id}, ${needs})")
  endforeach()
  file(CONFIGURE OUTPUT generated/technique_list.hpp CONTENT
"#pragma once
// From catalogue.json: X(id, needs).
#define TRIPTYCH_VOLUME_TECHNIQUES(X)${volume}
#define TRIPTYCH_PARTICLE_TECHNIQUES(X)${particles}
" @ONLY)
  set(${sources} ${files} PARENT_SCOPE)
endfunction()
