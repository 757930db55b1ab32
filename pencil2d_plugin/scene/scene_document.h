// The scene of the open project, observable and undoable; the user interface binds to it.
#pragma once

#include "scene/scene.h"
#include "user_error.h"

#include <QObject>
#include <QUndoStack>

namespace lampblack
{

class SceneDocument : public QObject
{
    Q_OBJECT

public:
    explicit SceneDocument(QObject* parent = nullptr);

    const Scene& scene() const { return mScene; }
    int selectedLight() const { return mSelectedLight; } ///< index, or -1
    QUndoStack* undoStack() { return &mUndo; }

    /// Names of the layers that are lit (characters and their lines); empty: every visible one.
    /// Kept in the scene's extra field "pencil2d_layers" as {"name": "character"|"line"|"background"}.
    QMap<QString, QString> layerRoles() const;
    void setLayerRoles(const QMap<QString, QString>& roles);

    /// Change the scene. Changes that share a `gesture` other than 0 (one drag, one spin) undo as
    /// one step named `text`. Values are clamped to the schema's ranges.
    void edit(const QString& text, const Scene& scene, int gesture = 0);
    void selectLight(int index);

    /// Start over: another project, nothing to undo, the first light selected.
    void reset(const Scene& scene);

    /// The sidecar of a project: "<project>.lampblack.json" beside it ("walk.pclx" has
    /// "walk.pclx.lampblack.json"). load() and save() return false and tell by problem() if it cannot be
    /// used; load() returns false in silence if there is none, and leaves the scene as it is either way. A
    /// broken file is never overwritten: it is first moved to "<name>.broken".
    static QString sidecarOf(const QString& projectPath);
    bool load(const QString& projectPath);
    bool save(const QString& projectPath);

    /// Whether the scene differs from what was last loaded, saved or reset to.
    bool isModified() const { return mScene != mKept; }

Q_SIGNALS:
    void sceneChanged();
    void selectionChanged(int light);
    void layerRolesChanged();
    void modifiedChanged(bool modified);
    void problem(const lampblack::UserError& error);

private:
    class Edit;

    void announce();

    Scene mScene;
    Scene mAnnounced; ///< the scene that listeners know
    Scene mKept;      ///< as last loaded, saved or reset to
    bool mAnnouncedModified = false;
    int mSelectedLight = -1;
    QUndoStack mUndo;
};

} // namespace lampblack
