#include "tool/panel/keys_row.h"

#include "scene/scene.h"
#include "tool/panel/value_row.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QPainter>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr int IconSide = 12;

QIcon diamondIcon(bool filled, const QPalette& palette, double pixelRatio)
{
    QIcon icon;
    for (const QIcon::Mode mode : {QIcon::Normal, QIcon::Disabled})
    {
        const auto group = mode == QIcon::Normal ? QPalette::Active : QPalette::Disabled;
        QPixmap pixmap((QSizeF(IconSide, IconSide) * pixelRatio).toSize());
        pixmap.setDevicePixelRatio(pixelRatio);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(palette.color(group, QPalette::ButtonText), 1.2));
        if (filled)
            painter.setBrush(palette.color(group, QPalette::Highlight));
        painter.drawPolygon(diamond(QPointF(IconSide, IconSide) / 2, IconSide / 2.0 - 1));
        painter.end();
        icon.addPixmap(pixmap, mode);
    }
    return icon;
}

QToolButton* button(const QString& name, QWidget* parent)
{
    auto* button = new QToolButton(parent);
    button->setObjectName(name);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    button->setIconSize(QSize(IconSide, IconSide));
    return button;
}

void setHint(QToolButton* button, const QString& hint)
{
    button->setToolTip(hint);
    button->setAccessibleName(hint);
}

} // namespace

KeysRow::KeysRow(const QString& name, Host& host, QWidget* parent)
    : QWidget(parent), mHost(host), mLabel(new QLabel(tr("Keys"), this)),
      mStrip(new KeyStrip(name + QStringLiteral(".strip"), this)),
      mPrevious(button(name + QStringLiteral(".previous"), this)),
      mToggle(button(name + QStringLiteral(".here"), this)),
      mNext(button(name + QStringLiteral(".next"), this))
{
    setObjectName(name);
    mPrevious->setArrowType(Qt::LeftArrow);
    mNext->setArrowType(Qt::RightArrow);
    setHint(mPrevious, tr("Go to the key before"));
    setHint(mNext, tr("Go to the key after"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    row->addWidget(mLabel);
    row->addWidget(mStrip, 1);
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(0);
    for (QToolButton* each : {mPrevious, mToggle, mNext})
        buttons->addWidget(each);
    row->addLayout(buttons);
    updateLabelWidth();
    updateIcons();
    connect(mToggle, &QToolButton::clicked, this, &KeysRow::keyToggled);
    connect(mPrevious, &QToolButton::clicked, this, [this] { mHost.goToFrame(previousKey()); });
    connect(mNext, &QToolButton::clicked, this, [this] { mHost.goToFrame(nextKey()); });
    connect(mStrip, &KeyStrip::frameClicked, this, [this](int frame) { mHost.goToFrame(frame); });
    connect(&host, &Host::frameChanged, this, &KeysRow::updateButtons);
    connect(&host, &Host::frameCountChanged, this, &KeysRow::updateButtons);
    updateButtons();
}

void KeysRow::setKeys(const QVector<int>& frames)
{
    mFrames = frames;
    mStrip->setKeys(frames);
    updateButtons();
}

void KeysRow::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange)
        updateLabelWidth();
    if (event->type() == QEvent::PaletteChange)
    {
        updateIcons();
        updateButtons();
    }
    QWidget::changeEvent(event);
}

void KeysRow::updateLabelWidth()
{
    mLabel->setFixedWidth(ValueRow::labelWidth(fontMetrics()));
}

void KeysRow::updateIcons()
{
    mKeyIcon = diamondIcon(true, palette(), devicePixelRatioF());
    mNoKeyIcon = diamondIcon(false, palette(), devicePixelRatioF());
}

void KeysRow::updateButtons()
{
    const int frame = mHost.currentFrame();
    const bool hasKey = mFrames.contains(frame);
    const bool isFull = !hasKey && mFrames.size() >= MaxKeys;
    mStrip->setTime(frame, mHost.frameCount());
    mToggle->setIcon(hasKey ? mKeyIcon : mNoKeyIcon);
    mToggle->setEnabled(!isFull);
    setHint(mToggle, isFull   ? tr("%1 keys at most").arg(MaxKeys)
                     : hasKey ? tr("Remove the key at frame %1").arg(frame)
                              : tr("Add a key at frame %1").arg(frame));
    mPrevious->setEnabled(previousKey() > 0);
    mNext->setEnabled(nextKey() > 0);
}

int KeysRow::previousKey() const
{
    const auto here = std::lower_bound(mFrames.begin(), mFrames.end(), mHost.currentFrame());
    return here == mFrames.begin() ? 0 : *std::prev(here);
}

int KeysRow::nextKey() const
{
    const auto next = std::upper_bound(mFrames.begin(), mFrames.end(), mHost.currentFrame());
    return next == mFrames.end() ? 0 : *next;
}

} // namespace lampblack
