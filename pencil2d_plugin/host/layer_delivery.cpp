#include "host/layer_delivery.h"

#include "host/layer_import.h"
#include "host/project_file.h"
#include "own_folder.h"

#include <QCryptographicHash>
#include <QDir>
#include <QImageReader>
#include <QPainter>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr int RetryMs = 60;      ///< while the artist is busy
constexpr int MaxSide = 4096;    ///< of a picture, pixels
constexpr int MaxCanvas = 16384; ///< of a picture transformed back to the canvas, pixels

QImage readPng(const QString& path)
{
    QImageReader reader(path, "png");
    const QSize size = reader.size();
    if (!size.isValid() || size.width() > MaxSide || size.height() > MaxSide)
        return {};
    return reader.read().convertToFormat(QImage::Format_ARGB32);
}

/// The picture on the canvas, without the camera's view. A null image if it would be too large.
Cel celFromPicture(const QImage& picture, const QTransform& view)
{
    const QPoint origin = originIn(picture.size()).toPoint();
    Cel cel = cut(picture, origin);
    if (view.isIdentity())
        return cel;
    const QTransform back = view.inverted();
    const QRect seen = back.mapRect(QRectF(QRect(cel.corner, cel.image.size()))).toAlignedRect();
    if (seen.width() > MaxCanvas || seen.height() > MaxCanvas)
        return {};
    QImage canvas(seen.size(), QImage::Format_ARGB32_Premultiplied);
    canvas.fill(Qt::transparent);
    QPainter painter(&canvas);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setTransform(back * QTransform::fromTranslate(-seen.x(), -seen.y()));
    painter.drawImage(cel.corner, cel.image);
    painter.end();
    return cut(canvas, -seen.topLeft());
}

QByteArray digestOf(const Cel& cel)
{
    QCryptographicHash hash(QCryptographicHash::Sha1);
    for (int y = 0; y < cel.image.height(); ++y)
        hash.addData(reinterpret_cast<const char*>(cel.image.constScanLine(y)), cel.image.width() * 4);
    return hash.result() + QByteArray::number(cel.corner.x()) + ',' + QByteArray::number(cel.corner.y()) +
           ',' + QByteArray::number(cel.image.width());
}

/// Returns an error message, empty on success.
QString writeLayer(ProjectFile* file, const QString& name, const QMap<int, QString>& pictures,
                   const CameraPath& camera, int frameCount)
{
    QString writeError = QStringLiteral("The key frames cannot be written to the temporary folder.");
    QImage empty(1, 1, QImage::Format_ARGB32);
    empty.fill(Qt::transparent);
    const Cel blank = cut(empty, QPoint());
    QByteArray lastDigest; // of the frame before
    int next = pictures.isEmpty() ? 1 : pictures.firstKey();
    for (auto picture = pictures.cbegin(); picture != pictures.cend(); ++picture)
    {
        if (picture.key() > next && !file->addKey(next, blank))
            return writeError;
        if (picture.key() > next)
            lastDigest.clear();
        next = picture.key() + 1;
        const QImage image = readPng(picture.value());
        if (image.isNull())
            return QStringLiteral("%1 cannot be read.").arg(picture.value());
        const Cel cel = celFromPicture(image, cameraAt(camera, picture.key()));
        if (cel.image.isNull())
            return QStringLiteral("Frame %1 would be too large on the canvas.").arg(picture.key());
        const QByteArray digest = digestOf(cel);
        if (digest == lastDigest)
            continue;
        lastDigest = digest;
        if (!file->addKey(picture.key(), cel))
            return writeError;
    }
    if (next <= frameCount && !file->addKey(next, blank))
        return writeError;
    return file->finish(name) ? QString() : writeError;
}

QStringList namesOf(const QVector<Layer>& layers)
{
    QStringList names;
    for (const Layer& layer : layers)
        names.append(layer.name);
    return names;
}

} // namespace

LayerDelivery::LayerDelivery(const Parts& parts, Idleness* idleness, QObject* parent)
    : QObject(parent), mParts(parts), mIdleness(idleness), mRows(parts), mFolder(ownFolderTemplate())
{
    mWriters.setMaxThreadCount(1);
    mTimer.setSingleShot(true);
    connect(&mTimer, &QTimer::timeout, this, &LayerDelivery::importWhenIdle);
}

LayerDelivery::~LayerDelivery()
{
    mWriters.clear();
    mWriters.waitForDone();
}

void LayerDelivery::deliver(const QString& name, const QMap<int, QString>& pictures, const CameraPath& camera,
                            int frameCount)
{
    cancel();
    mName = name;
    const QString folder = mFolder.filePath(QString::number(mNumber));
    if (!mFolder.isValid())
    {
        reportFailure(mFolder.errorString());
        return;
    }
    mWriters.start(
        [this, name, pictures, camera, frameCount, folder, number = mNumber]
        {
            ProjectFile file(folder);
            const QString error = writeLayer(&file, name, pictures, camera, frameCount);
            QMetaObject::invokeMethod(
                this,
                [this, error, number, path = file.path()]
                {
                    if (number != mNumber)
                        return;
                    mProject = path;
                    if (error.isEmpty())
                        importWhenIdle();
                    else
                        reportFailure(error);
                },
                Qt::QueuedConnection);
        });
}

void LayerDelivery::cancel()
{
    ++mNumber;
    mTimer.stop();
}

void LayerDelivery::importWhenIdle()
{
    if (mParts.window == nullptr)
        return;
    if (mPlaying || !mIdleness->isIdle())
    {
        mTimer.start(RetryMs);
        return;
    }
    const QString error = replaceLayer(mProject);
    if (error.isEmpty())
        Q_EMIT delivered(mName);
    else
        reportFailure(error);
}

QString LayerDelivery::replaceLayer(const QString& project)
{
    const Idleness::Work work(mIdleness);
    const UpdatesOff updatesOff(mParts.window);
    const QStringList before = namesOf(mRows.read());
    const int currentBefore = mRows.currentRow();
    if (before.isEmpty() || currentBefore < 0)
        return QStringLiteral("The list of layers does not answer.");

    QString error = importLayer(mParts, project, mName);
    const QStringList after = namesOf(mRows.read());
    if (after.mid(1) != before)
        return error.isEmpty() ? QStringLiteral("The layers are not as they should be: %1")
                                     .arg(after.join(QStringLiteral(", ")))
                               : error;
    // The old layer is removed only now, so that nothing is lost if the import fails.
    const int old = before.indexOf(mName);
    int current = currentBefore == old ? 0 : currentBefore + 1;
    if (old >= 0)
    {
        if (!mRows.remove(old + 1, mName))
            error = QStringLiteral("The layer made before could not be removed.");
        else if (old < currentBefore)
            --current;
        if (error.isEmpty() && !mRows.rename(0, mName))
            error = QStringLiteral("The new layer could not be named.");
    }
    mRows.select(current);
    // Pencil2D emits no signal for imported layers.
    const int count = mRows.read().size();
    QMetaObject::invokeMethod(mParts.layers, "layerCountChanged", Q_ARG(int, count));
    QMetaObject::invokeMethod(mParts.layers, "currentLayerChanged", Q_ARG(int, count - 1 - current));
    return error;
}

void LayerDelivery::reportFailure(const QString& details)
{
    Q_EMIT failed({QStringLiteral("The layer \"%1\" could not be put into the project.").arg(mName),
                   QStringLiteral("Save the project, then try again."), details});
}

} // namespace lampblack
