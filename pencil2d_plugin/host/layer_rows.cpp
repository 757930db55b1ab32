#include "host/layer_rows.h"

#include "host/timeline_cells.h"
#include "host/unseen_dialogs.h"

#include <QApplication>
#include <QInputDialog>
#include <QLineEdit>
#include <QPainter>

#include <array>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr int RowHeight = TimelineRowHeight;
constexpr int EyeX = 10;
constexpr int NameX = 80;
const QPoint IconCorner(19, -2);
constexpr int IconReach = 7; ///< each kind and version has its own place, a few pixels from another's
constexpr int MaxRows = 500;
const QPoint EyeCentre(EyeX, 8);

int difference(QRgb a, QRgb b)
{
    return std::abs(qRed(a) - qRed(b)) + std::abs(qGreen(a) - qGreen(b)) + std::abs(qBlue(a) - qBlue(b));
}

/// Mean difference between the icon on the row's background colour and the row's pixels at `at`. The icon may
/// be higher than the row.
double iconDifference(const QImage& rowImage, const QImage& icon, const QPoint& at)
{
    QImage expected(icon.size(), QImage::Format_RGB32);
    expected.fill(rowImage.pixel(1, RowHeight / 2));
    QPainter(&expected).drawImage(0, 0, icon);
    const QRect seen = QRect(at, icon.size()).intersected(rowImage.rect());
    qint64 sum = 0;
    for (int y = seen.top(); y <= seen.bottom(); ++y)
    {
        for (int x = seen.left(); x <= seen.right(); ++x)
            sum += difference(expected.pixel(QPoint(x, y) - at), rowImage.pixel(x, y));
    }
    return double(sum) / qMax(1, seen.width() * seen.height());
}

/// Pencil2D's own icon of a kind of layers; a null image if it has none that is known.
QImage iconOf(const char* kind)
{
    for (const char* path : {":/icons/layer-%1.png", ":/icons/themes/playful/timeline/cell-%1.svg"})
    {
        const QImage icon(QString::fromLatin1(path).arg(QLatin1String(kind)));
        if (!icon.isNull())
            return icon;
    }
    return {};
}

} // namespace

UpdatesOff::UpdatesOff(QWidget* window)
{
    if (window == nullptr || !window->updatesEnabled())
        return;
    window->setUpdatesEnabled(false);
    mWindow = window;
}

UpdatesOff::~UpdatesOff()
{
    if (mWindow == nullptr)
        return;
    mWindow->setUpdatesEnabled(true);
    // Qt drops a request to paint that comes meanwhile, and waits for it ever after: the window would stand
    // still until the mouse moves over it.
    QCoreApplication::postEvent(mWindow, new QEvent(QEvent::UpdateRequest), Qt::LowEventPriority);
}

QImage LayerRows::renderRow(int row) const
{
    const ScrolledCells scroll(mParts.layerCells, Qt::Vertical, row);
    QImage image(mParts.layerCells->width(), RowHeight, QImage::Format_RGB32);
    image.fill(Qt::magenta);
    mParts.layerCells->render(&image, QPoint(), QRegion(0, RowHeight, image.width(), RowHeight),
                              QWidget::DrawWindowBackground);
    return image;
}

void LayerRows::clickAt(int row, int x) const
{
    const ScrolledCells scroll(mParts.layerCells, Qt::Vertical, row);
    sendClick(mParts.layerCells, QPoint(x, RowHeight + RowHeight / 2));
}

void LayerRows::clickEye(int row) const
{
    clickAt(row, EyeX);
}

void LayerRows::select(int row) const
{
    clickAt(row, NameX);
}

int LayerRows::currentRow() const
{
    const QRgb highlight = QApplication::palette().color(QPalette::Highlight).rgb();
    const QRgb base = QApplication::palette().color(QPalette::Base).rgb();
    for (int row = 0; row < MaxRows; ++row)
    {
        const QRgb ground = renderRow(row).pixel(1, RowHeight / 2);
        if (difference(ground, highlight) < difference(ground, base))
            return row;
    }
    return -1;
}

QVector<bool> LayerRows::eyes(int count) const
{
    // With "current layer only" all other eyes are drawn closed, so show all layers meanwhile.
    QAction* onlyCurrent = mParts.action("actionVisibilityCurrentLayerOnly");
    QAction* all = mParts.action("actionVisibilityAll");
    const bool switched = onlyCurrent != nullptr && all != nullptr && onlyCurrent->isChecked();
    if (switched)
        all->trigger();

    const QRgb open = QApplication::palette().color(QPalette::Text).rgb();
    const QRgb shut = QApplication::palette().color(QPalette::Base).rgb();
    QVector<bool> eyes;
    for (int row = 0; row < count; ++row)
        eyes.append(difference(renderRow(row).pixel(EyeCentre), shut) > difference(open, shut) / 4);

    if (switched)
        onlyCurrent->trigger();
    return eyes;
}

void LayerRows::openProperties(int row) const
{
    const ScrolledCells scroll(mParts.layerCells, Qt::Vertical, row);
    sendMouse(mParts.layerCells, QEvent::MouseButtonDblClick, QPoint(NameX, RowHeight + RowHeight / 2),
              Qt::LeftButton);
}

QString LayerRows::nameAt(int row, bool* isCamera) const
{
    QString name;
    const UnseenDialogs dialogs(
        [&](QDialog* dialog)
        {
            if (const auto* input = qobject_cast<QInputDialog*>(dialog))
                name = input->textValue();
            else if (const auto* box = dialog->findChild<QLineEdit*>(QStringLiteral("nameBox")))
            {
                name = box->text();
                *isCamera = true;
            }
        });
    openProperties(row);
    return name;
}

bool LayerRows::remove(int row, const QString& name) const
{
    QAction* action = mParts.action("actionDelete_Current_Layer");
    bool isCamera = false;
    if (action == nullptr || nameAt(row, &isCamera) != name || isCamera)
        return false;
    select(row);
    // The current layer is deleted: make sure that it is this one, and that the question is about it.
    if (currentRow() != row)
        return false;
    bool asked = false;
    const UnseenDialogs dialogs([](QDialog*) {},
                                [&](const QString& question) { return asked = question.contains(name); });
    action->trigger();
    return asked && dialogs.complaints().isEmpty();
}

bool LayerRows::rename(int row, const QString& name) const
{
    bool isCamera = false;
    {
        const UnseenDialogs dialogs(
            [&](QDialog* dialog)
            {
                if (auto* input = qobject_cast<QInputDialog*>(dialog))
                {
                    input->setTextValue(name);
                    input->accept();
                }
            });
        openProperties(row);
    }
    return nameAt(row, &isCamera) == name;
}

Layer::Kind LayerRows::recogniseKind(const QImage& rowImage) const
{
    static const std::array<std::pair<const char*, Layer::Kind>, 4> Kinds{{{"bitmap", Layer::Kind::Bitmap},
                                                                           {"vector", Layer::Kind::Vector},
                                                                           {"sound", Layer::Kind::Sound},
                                                                           {"camera", Layer::Kind::Camera}}};
    constexpr double MaxDifference = 60;
    double best = MaxDifference;
    Layer::Kind kind = Layer::Kind::Unknown;
    for (const auto& [name, candidate] : Kinds)
    {
        const QImage icon = iconOf(name);
        if (icon.isNull())
            continue;
        for (int shift = 0; shift < IconReach * IconReach; ++shift)
        {
            const QPoint at = IconCorner + QPoint(shift % IconReach, shift / IconReach);
            const double fit = iconDifference(rowImage, icon, at);
            if (fit < best)
            {
                best = fit;
                kind = candidate;
            }
        }
    }
    return kind;
}

QVector<Layer> LayerRows::read() const
{
    const UpdatesOff updatesOff(mParts.window);
    const int current = currentRow();
    if (current < 0)
        return {};

    QVector<Layer> layers;
    for (int row = 0; row < MaxRows; ++row)
    {
        bool isCamera = false;
        Layer layer;
        layer.name = nameAt(row, &isCamera);
        if (layer.name.isNull())
            break;
        layer.kind = isCamera ? Layer::Kind::Camera : recogniseKind(renderRow(row));
        layers.append(layer);
    }
    select(current);
    const QVector<bool> open = eyes(layers.size());
    for (int row = 0; row < layers.size(); ++row)
        layers[row].visible = open[row];
    return layers;
}

} // namespace lampblack
