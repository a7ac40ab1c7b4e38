# What every target of the project has in common: warnings, and arithmetic that gives the same bits with every compiler.
add_library(mlsmesh_options INTERFACE)
target_compile_options(mlsmesh_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
  -ffp-contract=off
  $<$<BOOL:${MLSMESH_WARNINGS_AS_ERRORS}>:-Werror>)

# PCL's variables as one imported target, its headers as system headers so that its warnings are not ours.
function(mlsmesh_add_pcl)
  add_library(mlsmesh_pcl INTERFACE IMPORTED GLOBAL)
  set_target_properties(mlsmesh_pcl PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${PCL_INCLUDE_DIRS}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${PCL_INCLUDE_DIRS}")
  target_link_libraries(mlsmesh_pcl INTERFACE ${PCL_LIBRARIES})
endfunction()
