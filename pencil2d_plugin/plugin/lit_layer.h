// The layer of results, "Lit": rendered frames, back in the drawing.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"

#include <QMap>
#include <QSet>
#include <QThreadPool>

namespace lampblack
{

class LitLayer : public QObject
{
    Q_OBJECT

public:
    LitLayer(Host& host, SceneDocument& document, QObject* parent = nullptr);
    ~LitLayer() override;

    /// Whether the layer in the project is one that we made.
    bool isThere() const;

    /// Replace it by these PNG files, by frame; before the first time in a project, back the project up. With
    /// `hideSources`, what it was made from is hidden once it is there. delivered() or failed() tells.
    void deliver(const QMap<int, QString>& pictures, bool hideSources);

    /// Put there, and not saved since.
    bool isUnsaved() const { return mUnsaved; }

Q_SIGNALS:
    void delivered();
    void failed(const lampblack::UserError& error);

private:
    void afterBackup(const QString& project, const QString& fault);
    void settle();
    void fail(const UserError& error);

    Host& mHost;
    SceneDocument& mDocument;
    QThreadPool mCopier;
    QSet<QString> mBackedUp; ///< projects, in this session
    QMap<int, QString> mPictures;
    bool mHideSources = false;
    bool mUnsaved = false;
    bool mAtWork = false;
};

} // namespace lampblack
