// Writes sphere.png, a ball with a corner cut out, from Rust. It uses no crates, and declares only
// what it needs of crt.h.
//
//     rustc -O sphere.rs -L FOLDER_OF_LIBCRT && ./sphere
use std::ffi::{c_void, CStr, CString};
use std::os::raw::{c_char, c_int};
use std::{fmt, mem, ptr};

// ---- crt.h, as far as it is used ---------------------------------------------------------------

#[repr(C)]
struct Light {
    struct_size: u32,
    kind: i32,
    origin: [f64; 3],
    pointing: [f64; 3],
    color: [f64; 3],
    angle: f64,
    penumbra: f64,
    radius: f64,
    falloff: f64,
    ambient: f64,
}

#[repr(C)]
struct Camera {
    struct_size: u32,
    projection: i32,
    position: [f64; 3],
    pointing: [f64; 3],
    fov: f64,
    roll: f64,
    aperture: f64,
    focal_distance: f64,
    aperture_shape: i32,
    reserved: i32,
}

type Pointer = *mut c_void; // to an entity, a scene, ...

#[link(name = "crt")]
extern "C" {
    fn crt_error_message() -> *const c_char;
    fn crt_sphere_create(center: *const f64, radius: f64, out: *mut Pointer) -> c_int;
    fn crt_box_create(corner_a: *const f64, corner_b: *const f64, out: *mut Pointer) -> c_int;
    fn crt_difference_create(
        from: Pointer,
        cutters: *const Pointer,
        count: usize,
        out: *mut Pointer,
    ) -> c_int;
    fn crt_entity_release(entity: Pointer);
    fn crt_light_init(light: *mut Light, struct_size: usize) -> c_int;
    fn crt_camera_init(camera: *mut Camera, struct_size: usize) -> c_int;
    fn crt_scene_create(out: *mut Pointer) -> c_int;
    fn crt_scene_add_entity(scene: Pointer, entity: Pointer) -> c_int;
    fn crt_scene_add_light(scene: Pointer, light: *const Light) -> c_int;
    fn crt_scene_set_camera(scene: Pointer, camera: *const Camera) -> c_int;
    fn crt_scene_prepare(scene: Pointer, out: *mut Pointer) -> c_int;
    fn crt_scene_release(scene: Pointer);
    fn crt_render(prepared: Pointer, options: *const c_void, out: *mut Pointer) -> c_int;
    fn crt_prepared_release(prepared: Pointer);
    fn crt_image_write(image: Pointer, path: *const c_char) -> c_int;
    fn crt_image_release(image: Pointer);
}

// ---- errors and handles in Rust ----------------------------------------------------------------

#[derive(Debug)]
struct Error(String);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

fn check(status: c_int) -> Result<(), Error> {
    if status == 0 {
        return Ok(());
    }
    let message = unsafe { CStr::from_ptr(crt_error_message()) };
    Err(Error(message.to_string_lossy().into_owned()))
}

/// A Handle is one reference to something of the library, dropped with this.
struct Handle {
    pointer: Pointer,
    release: unsafe extern "C" fn(Pointer),
}

impl Handle {
    /// Takes what `create` puts into its argument.
    fn new(
        release: unsafe extern "C" fn(Pointer),
        create: impl FnOnce(&mut Pointer) -> c_int,
    ) -> Result<Handle, Error> {
        let mut pointer = ptr::null_mut();
        check(create(&mut pointer))?;
        Ok(Handle { pointer, release })
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        unsafe { (self.release)(self.pointer) }
    }
}

fn sphere(center: [f64; 3], radius: f64) -> Result<Handle, Error> {
    Handle::new(crt_entity_release, |out| unsafe {
        crt_sphere_create(center.as_ptr(), radius, out)
    })
}

fn cuboid(a: [f64; 3], b: [f64; 3]) -> Result<Handle, Error> {
    Handle::new(crt_entity_release, |out| unsafe { crt_box_create(a.as_ptr(), b.as_ptr(), out) })
}

fn difference(from: &Handle, cutter: &Handle) -> Result<Handle, Error> {
    Handle::new(crt_entity_release, |out| unsafe {
        crt_difference_create(from.pointer, &cutter.pointer, 1, out)
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let part = difference(&sphere([0.0; 3], 1.0)?, &cuboid([0.0, 0.0, -2.0], [2.0, 2.0, 0.0])?)?;
    let scene = Handle::new(crt_scene_release, |out| unsafe { crt_scene_create(out) })?;

    unsafe {
        let mut light: Light = mem::zeroed();
        check(crt_light_init(&mut light, mem::size_of::<Light>()))?;
        light.origin = [4.0, 5.0, -6.0];
        light.ambient = 0.15;
        let mut camera: Camera = mem::zeroed();
        check(crt_camera_init(&mut camera, mem::size_of::<Camera>()))?;
        camera.position = [1.6, 2.0, -4.0];
        camera.fov = 0.7;
        check(crt_scene_add_entity(scene.pointer, part.pointer))?;
        check(crt_scene_add_light(scene.pointer, &light))?;
        check(crt_scene_set_camera(scene.pointer, &camera))?;
    }

    let prepared = Handle::new(crt_prepared_release, |out| unsafe {
        crt_scene_prepare(scene.pointer, out)
    })?;
    let image = Handle::new(crt_image_release, |out| unsafe {
        crt_render(prepared.pointer, ptr::null(), out)
    })?;
    let path = CString::new("sphere.png")?;
    check(unsafe { crt_image_write(image.pointer, path.as_ptr()) })?;
    println!("sphere.png is there");

    // This shows what an error looks like.
    if let Err(error) = sphere([0.0; 3], -1.0) {
        println!("a wrong sphere: {}", error);
    }
    Ok(())
}
