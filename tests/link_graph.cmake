# gnomon_links_nothing_of(TARGET PLACE...): stops the configuration where a target links one of these, however far down.
function(gnomon_links_nothing_of target)
  set(seen "")
  set(open ${target})
  while(open)
    list(POP_FRONT open next)
    if(NOT TARGET ${next} OR ${next} IN_LIST seen)
      continue()
    endif()
    list(APPEND seen ${next})
    foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
      get_target_property(libraries ${next} ${property})
      if(libraries)
        # What is linked privately by a static library is written $<LINK_ONLY:name>.
        string(REGEX REPLACE "\\$<LINK_ONLY:([^>]*)>" "\\1" libraries "${libraries}")
        list(APPEND open ${libraries})
      endif()
    endforeach()
  endwhile()
  foreach(place IN LISTS ARGN)
    if(${place} IN_LIST seen)
      message(FATAL_ERROR "${target} links ${place}, which it must not know")
    endif()
  endforeach()
endfunction()

# What a frame needs apart from who draws it: planning, reports and evaluations draw through renderer/device alone.
foreach(target gnomon_bake gnomon_charts gnomon_cpu gnomon_device gnomon_evaluation gnomon_export gnomon_frame gnomon_prepare
               gnomon_rays gnomon_reference gnomon_resolve gnomon_techniques gnomon_video gnomon_volume)
  gnomon_links_nothing_of(${target} gnomon_gl gnomon_passes gnomon_glad)
endforeach()

# The process that listens never reads a scene, decodes an image or draws.
gnomon_links_nothing_of(gnomon_server gnomon_scene gnomon_image gnomon_device gnomon_frame gnomon_renderer)
